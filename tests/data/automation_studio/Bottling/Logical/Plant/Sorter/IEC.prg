<?xml version="1.0" encoding="utf-8"?>
<?AutomationStudio Version=4.12.2.93 SP?>
<Program SubType="IEC" xmlns="http://br-automation.co.at/AS/Program">
  <Files>
    <File>Cyclic.ab</File>
    <File>Init.ab</File>
    <File>Clean.st</File>
    <File Private="true">Sorter.var</File>
  </Files>
</Program>